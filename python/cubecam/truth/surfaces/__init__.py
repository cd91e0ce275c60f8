"""What rays meet, and what a surface is like where they meet it."""
