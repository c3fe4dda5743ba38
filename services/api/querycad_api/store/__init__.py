"""What lasts between requests: models and jobs in Redis, tasks on its queues, files, and what mends them."""
