"""What people look at: pictures (`plot`), a robot in a browser (`scene`, `view`) and the report of a run (`report`)."""
