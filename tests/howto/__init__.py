"""The pages of docs/howto and docs/explanation: their code runs, and what they say is true."""
