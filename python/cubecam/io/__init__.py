"""Read and write files: pictures, cubemaps and meshes."""
