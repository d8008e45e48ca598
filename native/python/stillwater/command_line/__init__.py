"""`python -m stillwater`: one file a command. main.py reads the arguments and says what went wrong."""
