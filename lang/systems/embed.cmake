# The built-in systems are Cascade texts; this turns them into one C++ file of raw strings.
