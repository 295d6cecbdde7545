# cmake -DTABLE=cmake/rooms.cmake -P print_rooms.cmake: the table, a line a room,
# with the rooms above it that it may not use.
include(${TABLE})
message("sees_hidden|${sees_hidden}")
foreach(room ${rooms})
  message("${room}|${not_from_${room}}")
endforeach()
