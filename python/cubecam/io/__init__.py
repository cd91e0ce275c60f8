"""Files in and out: pictures, cubemaps and meshes."""
