"""Small reference pictures, compared on llvmpipe only."""
