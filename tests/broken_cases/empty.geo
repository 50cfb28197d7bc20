// Nothing in it.
