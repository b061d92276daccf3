"""The pictures of docs/gallery.md, each made by one function: `python -m scripts.gallery [NAME ...] [--out FOLDER]`."""
