"""One module for each implementation of a workload; each is imported only in a process of its own."""
