# Writes a file for ctest with one test for each suite of a GoogleTest program that a filter
# selects. Starting a process for every case would take longer than most cases do.
#   cmake -D PROGRAM=... -D PREFIX=... -D FILTER=... -D TIER=... -D OUTPUT=... -P discover_suites.cmake
# Tests are named <prefix><suite>, and <prefix><suite>.<tier> in the tiers above quick. Each writes
# <prefix><suite>.xml, with the number and results of its cases, to the folder of OUTPUT.

execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=${FILTER}
                OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" lines "${listed}")
get_filename_component(folder ${OUTPUT} DIRECTORY)
set(suites)
foreach(line IN LISTS lines)
  string(REGEX REPLACE "  #.*" "" name "${line}")  # types and parameters
  if(name MATCHES "^  (.+)")
    list(APPEND cases_of_${suite} "${suite}.${CMAKE_MATCH_1}")
  elseif(name MATCHES "^([^ ]+)\\.$")
    set(suite ${CMAKE_MATCH_1})
    list(APPEND suites ${suite})
  endif()
endforeach()

set(script "")
foreach(suite IN LISTS suites)
  list(JOIN cases_of_${suite} ":" cases)
  set(name "${PREFIX}${suite}")
  string(REPLACE "/" "_" report "${name}.xml")
  if(NOT TIER STREQUAL "quick")
    string(APPEND name ".${TIER}")
  endif()
  string(APPEND script "add_test([=[${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${cases}]=]"
                       " [=[--gtest_output=xml:${folder}/${report}]=])\n"
                       "set_tests_properties([=[${name}]=] PROPERTIES TIMEOUT 900 LABELS ${TIER})\n")
endforeach()
file(WRITE ${OUTPUT} "${script}")
