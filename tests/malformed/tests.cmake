# Files that are bad or odd, made by a script; script/malformed gives them to PCL and Open3D, too.
# Sanitizers reserve more addresses than any limit leaves.
add_test(NAME malformed
         COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/malformed_test.py
                 $<TARGET_FILE:dynamicfilter> $<IF:$<CONFIG:Sanitize>,0,4>)
