"""Truth: its shading against facts, and what it renders against closed forms and the renderer."""
