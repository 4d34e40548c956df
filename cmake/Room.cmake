# strut_room(NAME SOURCES … SEES … READS … PRIVATE … PRECOMPILED header | HEADERS_OF room): the library strut_NAME of the
# folder it is called from.
# Its headers are reached as "NAME/header.hpp" through a folder that holds a link to this room alone, so the rooms
# a target can include are exactly those it names (and what these see). SEES also links them; READS takes types from
# their headers without linking them: the deck needs that for the conditions, laws and formulations that it names.
# PRECOMPILED names the header that most sources of this room include, and of the rooms that say HEADERS_OF this one.
function(strut_room name)
  cmake_parse_arguments(room "" "PRECOMPILED;HEADERS_OF" "SOURCES;SEES;READS;PRIVATE" ${ARGN})
  set(includes ${CMAKE_BINARY_DIR}/rooms/${name})
  file(MAKE_DIRECTORY ${includes})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${includes}/${name} SYMBOLIC)
  add_library(strut_${name} STATIC ${room_SOURCES})
  target_include_directories(strut_${name} PUBLIC ${includes})
  foreach(room IN LISTS room_READS)
    target_include_directories(strut_${name} PUBLIC ${CMAKE_BINARY_DIR}/rooms/${room})
  endforeach()
  list(TRANSFORM room_SEES PREPEND strut_)
  target_link_libraries(strut_${name} PUBLIC ${room_SEES} PRIVATE ${room_PRIVATE})
  if(room_PRECOMPILED)
    strut_common_headers(strut_${name} OWNER strut_${name} MORE ${CMAKE_CURRENT_SOURCE_DIR}/${room_PRECOMPILED})
  elseif(room_HEADERS_OF)
    strut_common_headers(strut_${name} OWNER strut_${room_HEADERS_OF})
  else()
    strut_common_headers(strut_${name})
  endif()
endfunction()
