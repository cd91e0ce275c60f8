"""Live views as pages of a browser, behind a token; imported when the first page is shown."""
