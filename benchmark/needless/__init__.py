"""Which statements of the readers change no right answer?"""
