"""Settings of Sphinx for cubecam's site; `make docs` builds it. The build uses no network."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

os.environ.pop("MPLBACKEND", None)  # kernels show their figures only with their own backend
# Lessons run in kernels of their own, which say so on each start.
os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
sys.path.insert(0, str(Path(__file__).parent))

from _ext.repository import files_url, package_hash

import cubecam

project = "cubecam"
author = "cubecam authors"
version = release = cubecam.__version__
project_copyright = author

extensions = [
    "myst_nb",
    "sphinx_copybutton",
    "sphinx_design",
    "_ext.repository",
    "_ext.gallery",  # before sphinx_gallery: it writes the scripts
    "sphinx_gallery.gen_gallery",
    "_ext.reference",
    "_ext.commands",
    "_ext.mathml",
    "_ext.widgets",
]
exclude_patterns = [
    "_build",
    "_ext",
    "images",
    "gallery/*.py",
    "gallery/*.ipynb",
    "gallery/**/*.json",
]
nitpicky = True
#: Types of others, which no page of this site describes.
nitpick_ignore_regex = [
    (
        r"py:.*",
        r"(ArrayLike|NDArray|DTypeLike|PathLike|Path|Executor|Iterable|Iterator|Sequence|Mapping|Callable|Unpack)",
    ),
    (
        r"py:.*",
        r"(float16|float32|float64|int32|int64|uint8|uint16|uint32|integer|generic|bool_|dtype)",
    ),
    # What some properties of live views give; they are made by cubecam alone.
    (r"py:.*", r"(Cross|Facts|Look|Panorama|Plane|Section)"),
    (r"py:.*", r"(Axes|Figure|Normalize|Colormap|Console|Self|AnyLight|AnyCamera|MutableMapping)"),
    (r"py:.*", r"(xarray\.Dataset|Dataset|dask\.array\.Array|Client|(zarr\.abc\.store\.)?Store)"),
    (r"py:.*", r"T"),  # what a PictureFuture gives
]

cubecam_repository = files_url()
cubecam_hash = package_hash()

# ----- text

source_suffix = {".md": "myst-nb", ".ipynb": "myst-nb", ".rst": "restructuredtext"}
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
default_role = "name"
html_math_renderer = "mathml"
add_module_names = True
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88
toc_object_entries_show_parents = "hide"
highlight_language = "default"
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

# ----- lessons and the tutorial

nb_execution_mode = "cache"
nb_execution_cache_path = str(Path(__file__).parent / "_build" / "lessons" / cubecam_hash)
nb_execution_timeout = 300
nb_execution_in_temp = True  # what they write is not kept
nb_execution_raise_on_error = True
nb_execution_show_tb = True
nb_merge_streams = True
# A live view is a widget of a kernel that is gone; the picture beside it is what a reader sees.
nb_ipywidgets_js: dict[str, Any] = {}
nb_mime_priority_overrides = [("html", "application/vnd.jupyter.widget-view+json", None)]

# ----- gallery

sphinx_gallery_conf = {
    "examples_dirs": "_build/gallery",
    "gallery_dirs": "gallery",
    "filename_pattern": r"/plot_",
    "within_subsection_order": "FileNameSortKey",
    "image_scrapers": ("_ext.gallery.scrape",),
    "reset_modules": (),
    "download_all_examples": False,
    "show_signature": False,
    "show_memory": False,
    "min_reported_time": 1e9,
    "write_computation_times": False,
    "copyfile_regex": "",
    "thumbnail_size": (320, 320),
    "default_thumb_file": None,
    "abort_on_example_error": True,
    "remove_config_comments": True,
    "plot_gallery": "True",
}

# ----- HTML

html_theme = "pydata_sphinx_theme"
html_title = "cubecam"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_favicon = "_static/cubecam.svg"
html_show_sourcelink = False
html_copy_source = False
html_context = {"default_mode": "auto"}
html_theme_options: dict[str, Any] = {
    "logo": {
        "text": "cubecam",
        "image_light": "_static/cubecam.svg",
        "image_dark": "_static/cubecam.svg",
    },
    "header_links_before_dropdown": 7,
    "navbar_align": "left",
    "navbar_end": ["theme-switcher"],
    "show_toc_level": 2,
    "show_nav_level": 1,
    "navigation_with_keys": True,
    "use_edit_page_button": False,
    "back_to_top_button": True,
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
html_sidebars = {"index": [], "tutorial": [], "lessons": ["sidebar-nav-bs"]}
