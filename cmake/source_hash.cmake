# What armcal is compiled from as one number, which results name: the first 12
# digits of the SHA-256 of what `sha256sum` prints of all sources in the order of
# their names. Other than a commit it is there without git, changes with a file
# that is not committed, and does not change with a document.
#
# source_files(OUT) are the sources; cmake -DROOT=. -DOUT=FILE -P source_hash.cmake
# writes FILE with the number.
function(source_files out)
  set(patterns)
  foreach(folder model problems calib tools)
    foreach(ending h cc inc)
      list(APPEND patterns ${ROOT}/${folder}/*.${ending})
    endforeach()
  endforeach()
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${patterns}
       ${ROOT}/tools/report/assets/* ${ROOT}/cmake/*.cmake)
  list(APPEND files CMakeLists.txt)
  list(SORT files)
  set(${out} ${files} PARENT_SCOPE)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  source_files(files)
  set(sums "")
  foreach(file ${files})
    file(SHA256 ${ROOT}/${file} sum)
    string(APPEND sums "${sum}  ${file}\n")
  endforeach()
  string(SHA256 hash "${sums}")
  string(SUBSTRING ${hash} 0 12 hash)
  file(CONFIGURE OUTPUT ${OUT} CONTENT "#include \"tools/source_hash.h\"

namespace armcal {

const char* SourceHash() { return \"${hash}\"; }

}  // namespace armcal
")
endif()
