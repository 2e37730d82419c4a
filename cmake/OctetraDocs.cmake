# Targets that are no part of the default build: `man`, the manual pages from --help, and
# `api-docs`, pages of the public headers. Packages: [docs] of packages.txt.
include(GNUInstallDirs)

find_program(OCTETRA_HELP2MAN NAMES help2man)
find_program(OCTETRA_DOXYGEN NAMES doxygen)

if(OCTETRA_HELP2MAN)
  add_custom_target(man
    COMMAND python3 ${CMAKE_SOURCE_DIR}/tools/man_pages.py --octetra $<TARGET_FILE:octetra>
            --help2man ${OCTETRA_HELP2MAN} -o ${CMAKE_BINARY_DIR}/man
    DEPENDS octetra COMMENT "Making the manual pages, man/octetra.1 and on" VERBATIM)
else()
  add_custom_target(man
    COMMAND ${CMAKE_COMMAND} -E echo "The manual pages need help2man: apt-get install help2man"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
# If they have been made by then.
install(DIRECTORY ${CMAKE_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL
        FILES_MATCHING PATTERN "*.1")

if(OCTETRA_DOXYGEN)
  file(GLOB folders ${CMAKE_SOURCE_DIR}/*/include)
  list(JOIN folders " " OCTETRA_PUBLIC_FOLDERS)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${CMAKE_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(api-docs COMMAND ${OCTETRA_DOXYGEN} ${CMAKE_BINARY_DIR}/Doxyfile
    COMMENT "Making the pages of the public headers, api/index.html" VERBATIM)
else()
  add_custom_target(api-docs
    COMMAND ${CMAKE_COMMAND} -E echo "These pages need doxygen: apt-get install doxygen"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
