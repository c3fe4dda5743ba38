"""Edge treatments: fillets, rounds and chamfers."""
