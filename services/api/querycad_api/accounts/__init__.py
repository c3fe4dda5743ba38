"""Who may ask: API keys, the tenants that they stand for, and how much each may do."""
