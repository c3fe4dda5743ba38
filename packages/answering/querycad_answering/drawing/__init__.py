"""What is told of a model without a question: callouts as on a drawing, tables, a description."""
