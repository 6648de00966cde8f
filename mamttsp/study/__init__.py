"""What only the notebooks look at, beside the methods: nothing else of the library needs it."""
