"""The HTTP interface: uploads, questions, answers; and the writing of the programs that answer them."""
