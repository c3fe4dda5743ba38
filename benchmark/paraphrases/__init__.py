"""Do many ways to ask the same have the same answer?"""
