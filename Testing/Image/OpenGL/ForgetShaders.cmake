# Empties the folder that shaders are captured in: those of older code say nothing.
file(REMOVE_RECURSE "${folder}")
file(MAKE_DIRECTORY "${folder}")
