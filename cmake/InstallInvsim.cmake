# Install target and exported package; written with the set-up work.
