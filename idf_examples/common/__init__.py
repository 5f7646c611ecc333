"""Code shared by the generators of large models. Only Python's standard library is used."""
