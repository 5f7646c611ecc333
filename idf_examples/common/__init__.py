"""What the generators of large models share. Only Python's standard library is used."""
