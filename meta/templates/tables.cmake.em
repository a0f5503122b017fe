@# Context:
@#   sources  paths of the generated C++ files
@#   inputs   paths of all inputs; CMake runs the generator again when one of them changes
# generated from meta/messages.txt and meta/services.txt, do not edit
set(BUBBLESIM_TABLE_SOURCES
@[for path in sources]@
  "@path"
@[end for]@
)
set(BUBBLESIM_TABLE_INPUTS
@[for path in inputs]@
  "@path"
@[end for]@
)
