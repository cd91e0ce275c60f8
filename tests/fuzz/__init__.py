"""Broken input of every kind: no crash, no hang, no memory beyond a bound. `make fuzz` runs it for longer."""
