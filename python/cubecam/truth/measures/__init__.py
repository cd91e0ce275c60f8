"""How far a picture is from another one: numbers, and a figure of them."""
