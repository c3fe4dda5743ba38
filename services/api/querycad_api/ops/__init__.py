"""What is seen of the service from outside: request log, metrics, health."""
