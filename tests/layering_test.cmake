# cmake -DROOT=... -DWORK_DIR=... -P layering_test.cmake
#
# Holds the folders to the layers of README.md, libraries to printing nothing
# and files to their budgets. Before the real tree it judges one in WORK_DIR
# that breaks every rule, so that a rule that stopped working is noticed.
cmake_minimum_required(VERSION 3.25)

# Which folders a file may include from.
set(from_model model model/simd)
set(from_model/simd ${from_model})
set(from_model/effects ${from_model} model/effects)
set(from_model/plant ${from_model} model/plant)
set(from_model/plant/hidden ${from_model/plant} model/plant/hidden)
set(from_problems ${from_model/effects} problems)
set(from_calib ${from_problems} model/plant calib)
set(from_tools ${from_calib} tools tools/report)
set(from_tools/report ${from_tools})
set(from_tools/python ${from_tools} tools/python)
set(libraries model model/simd model/effects model/plant model/plant/hidden
    problems calib)
set(folders ${libraries} tools tools/report tools/python)

# Lines of a file of each kind; more than half above that is refused.
set(budget_header 140)
set(budget_source 280)
set(budget_test 220)

set(print_call "(^|[^A-Za-z_])(printf|fprintf|vprintf|puts|fputs|putchar) *\\(")
set(prints "std::(cout|cerr|clog)|<iostream>|${print_call}|LOG\\((INFO|WARNING|ERROR)\\)")

function(complain text)
  set_property(GLOBAL APPEND PROPERTY complaints "${text}")
endfunction()

function(check_includes root file folder)
  set(allowed ${from_${folder}})
  if(file MATCHES "^tools/simulate")
    list(APPEND allowed model/plant/hidden)
  endif()
  file(STRINGS ${root}/${file} includes REGEX "^ *# *include *\"")
  foreach(line ${includes})
    string(REGEX REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1" included "${line}")
    get_filename_component(from "${included}" DIRECTORY)
    if(NOT EXISTS ${root}/${included} OR from STREQUAL "")
      complain("${file}: includes ${included}: expected a path from the root")
    elseif(NOT from IN_LIST allowed)
      complain("${file}: includes ${included}: ${folder} may not use ${from}")
    endif()
  endforeach()
  file(STRINGS ${root}/${file} simbody REGEX "# *include *[<\"](Simbody|SimTK)")
  if(simbody AND NOT folder STREQUAL model/plant)
    complain("${file}: includes Simbody: only model/plant may")
  endif()
endfunction()

function(check_silence root file)
  file(STRINGS ${root}/${file} lines REGEX "${prints}")
  if(lines)
    complain("${file}: prints: libraries return results, tools print them")
  endif()
endfunction()

# --json, --quiet and full disks are looked after in one place.
function(check_console root file)
  file(STRINGS ${root}/${file} lines REGEX "std::cout|[(, ]stdout[),]|${print_call}")
  if(lines AND NOT file MATCHES "^tools/console\\.(h|cc)$")
    complain("${file}: prints: commands do so through tools/console.h")
  endif()
endfunction()

function(check_size root file)
  set(kind source)
  if(file MATCHES "\\.h$")
    set(kind header)
  elseif(file MATCHES "^tests/")
    set(kind test)
  endif()
  set(budget ${budget_${kind}})
  file(READ ${root}/${file} text)
  string(REGEX MATCHALL "\n" newlines "${text}")
  list(LENGTH newlines lines)
  math(EXPR limit "${budget} * 3 / 2")
  if(lines GREATER limit)
    complain("${file}: ${lines} lines: a ${kind} has ${budget}, at most ${limit}")
  elseif(lines GREATER budget)
    message("over budget: ${file}: ${lines} lines, a ${kind} has ${budget}")
  endif()
endfunction()

function(check_names root)
  foreach(top model problems calib tools tests data docs)
    file(GLOB_RECURSE paths LIST_DIRECTORIES true RELATIVE ${root} ${root}/${top}/*)
    foreach(path ${paths})
      get_filename_component(name ${path} NAME_WE)
      if(name MATCHES "^(utils?|common|misc|helpers?|types)$")
        complain("${path}: the name says nothing")
      endif()
    endforeach()
  endforeach()
endfunction()

# Sets `complaints` to what is wrong in the tree at `root`.
function(check_tree root)
  set_property(GLOBAL PROPERTY complaints "")
  foreach(folder ${folders})
    file(GLOB files RELATIVE ${root} ${root}/${folder}/*.h ${root}/${folder}/*.cc)
    foreach(file ${files})
      check_includes(${root} ${file} ${folder})
      check_size(${root} ${file})
      if(folder IN_LIST libraries)
        check_silence(${root} ${file})
      elseif(folder STREQUAL tools)
        check_console(${root} ${file})
      endif()
    endforeach()
  endforeach()
  file(GLOB files RELATIVE ${root} ${root}/tests/*.h ${root}/tests/*.cc)
  foreach(file ${files})
    check_size(${root} ${file})
  endforeach()
  check_names(${root})
  get_property(found GLOBAL PROPERTY complaints)
  set(complaints "${found}" PARENT_SCOPE)
endfunction()

# A tree that breaks every rule once.
set(bad ${WORK_DIR}/bad_layers)
file(REMOVE_RECURSE ${bad})
file(WRITE ${bad}/model/a.h "#include \"problems/b.h\"\n")
file(WRITE ${bad}/model/c.h "#include \"a.h\"\n")
file(WRITE ${bad}/model/d.cc "#include \"model/plant/e.h\"\n")
file(WRITE ${bad}/model/plant/e.h "#include \"model/effects/f.h\"\n")
file(WRITE ${bad}/model/effects/f.h "#include <Simbody.h>\n")
file(WRITE ${bad}/model/plant/hidden/g.h "#pragma once\n")
file(WRITE ${bad}/problems/b.h "void F() { std::printf(\"x\"); }\n")
file(WRITE ${bad}/calib/h.cc "#include \"model/plant/hidden/g.h\"\n")
file(WRITE ${bad}/calib/i.cc "#include \"tools/j.h\"\n")
file(WRITE ${bad}/calib/k.cc "void F() { std::cerr << 1; }\n")
file(WRITE ${bad}/tools/j.h "#include \"model/plant/hidden/g.h\"\n")
file(WRITE ${bad}/tools/n.cc "void F() { std::cout << 1; }\n")
file(WRITE ${bad}/tools/simulate.cc "#include \"model/plant/hidden/g.h\"\n")
string(REPEAT "\n" 211 lines)
file(WRITE ${bad}/calib/l.h "${lines}")
file(WRITE ${bad}/tests/misc/m_test.cc "\n")
check_tree(${bad})
foreach(expected
    "model/a.h: includes problems/b.h"
    "model/c.h: includes a.h"
    "model/d.cc: includes model/plant/e.h"
    "model/plant/e.h: includes model/effects/f.h"
    "model/effects/f.h: includes Simbody"
    "problems/b.h: prints"
    "calib/h.cc: includes model/plant/hidden/g.h"
    "calib/i.cc: includes tools/j.h"
    "calib/k.cc: prints"
    "tools/j.h: includes model/plant/hidden/g.h"
    "calib/l.h: 211 lines"
    "tools/n.cc: prints"
    "tests/misc: the name says nothing")
  if(NOT complaints MATCHES "${expected}")
    message(SEND_ERROR "layering_test.cmake no longer notices: ${expected}")
  endif()
endforeach()
list(LENGTH complaints count)
if(NOT count EQUAL 13)
  message(SEND_ERROR "13 complaints about the bad tree expected: ${complaints}")
endif()

check_tree(${ROOT})
foreach(complaint ${complaints})
  message(SEND_ERROR "${complaint}")
endforeach()
