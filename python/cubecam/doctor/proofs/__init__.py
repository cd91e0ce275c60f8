"""The self-test: what a driver draws is compared with numpy, on the user's own machine."""
