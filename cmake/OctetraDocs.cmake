# Documentation generated from the program and the headers. `man`, the manual pages from --help, is
# part of the default build if its tools are installed, so that the pages are installed; `api-docs`,
# pages of the public headers, is not. Packages: [docs] of packages.txt.
include(GNUInstallDirs)

find_program(OCTETRA_HELP2MAN NAMES help2man)
find_package(Python3 QUIET COMPONENTS Interpreter)
find_program(OCTETRA_DOXYGEN NAMES doxygen)

if(OCTETRA_HELP2MAN AND Python3_FOUND AND NOT CMAKE_CROSSCOMPILING)  # runs the program
  set(script ${PROJECT_SOURCE_DIR}/tools/man_pages.py)
  # A page for each subcommand, and octetra.1 for the program. Pages of an earlier build are
  # removed.
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/man/octetra.1
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/man
    COMMAND ${Python3_EXECUTABLE} ${script} --octetra $<TARGET_FILE:octetra>
            --help2man ${OCTETRA_HELP2MAN} -o ${PROJECT_BINARY_DIR}/man
    DEPENDS octetra ${script} COMMENT "Making the manual pages, man/octetra.1 and on" VERBATIM)
  add_custom_target(man ALL DEPENDS ${PROJECT_BINARY_DIR}/man/octetra.1)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
          FILES_MATCHING PATTERN "*.1")
else()
  add_custom_target(man
    COMMAND ${CMAKE_COMMAND} -E echo "The manual pages need help2man and python3: apt-get install help2man"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()

if(OCTETRA_DOXYGEN)
  file(GLOB folders ${PROJECT_SOURCE_DIR}/*/include)
  list(JOIN folders " " OCTETRA_PUBLIC_FOLDERS)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(api-docs COMMAND ${OCTETRA_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile
    COMMENT "Making the pages of the public headers, api/index.html" VERBATIM)
else()
  add_custom_target(api-docs
    COMMAND ${CMAKE_COMMAND} -E echo "These pages need doxygen: apt-get install doxygen"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
