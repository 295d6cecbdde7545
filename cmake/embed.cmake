# embed(OUT NAME FILE [NAME FILE ...])
#
# Assembler source, whose path goes into OUT, that puts each file byte by byte
# between the symbols embedded_NAME and embedded_NAME_end.
function(embed out)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${out}.S)
  set(text ".section .rodata\n")
  set(files)
  while(ARGN)
    list(POP_FRONT ARGN name file)
    if(NOT EXISTS ${file})
      message(FATAL_ERROR "${file} is missing: run tools/setup.sh")
    endif()
    string(APPEND text ".global embedded_${name}\n.global embedded_${name}_end\n"
           "embedded_${name}:\n.incbin \"${file}\"\nembedded_${name}_end:\n")
    list(APPEND files ${file})
  endwhile()
  string(APPEND text ".section .note.GNU-stack,\"\",%progbits\n")
  file(CONFIGURE OUTPUT ${source} CONTENT "${text}" @ONLY)
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${files}")
  set(${out} ${source} PARENT_SCOPE)
endfunction()
