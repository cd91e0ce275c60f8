"""How `StandardMaterial` scatters light: values, densities, and directions drawn from them."""
