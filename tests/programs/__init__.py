"""Each program of the documents against numpy written from the document, over several frames."""
