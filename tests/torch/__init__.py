"""docs/howto/train.md with PyTorch: make test-torch."""
