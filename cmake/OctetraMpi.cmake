# The requirements on MPI in a file for pkg-config. Several MPIs may be installed side by side, and each has packages of its
# own; the required package is that of the MPI that FindMPI has found.

# octetra_mpi_package(<variable>): the package of Open MPI or MPICH whose headers are in MPI_CXX_INCLUDE_DIRS; empty
# for other MPIs, and where there is no pkg-config.
function(octetra_mpi_package variable)
  set(${variable} "" PARENT_SCOPE)
  find_package(PkgConfig QUIET)
  if(NOT PKG_CONFIG_FOUND)
    return()
  endif()
  set(found)
  foreach(folder IN LISTS MPI_CXX_INCLUDE_DIRS)
    file(REAL_PATH ${folder} folder)
    list(APPEND found ${folder})
  endforeach()
  foreach(package ompi-cxx mpich)
    pkg_get_variable(headers ${package} includedir)
    if(headers)
      file(REAL_PATH ${headers} headers)
      if(headers IN_LIST found)
        set(${variable} ${package} PARENT_SCOPE)
        return()
      endif()
    endif()
  endforeach()
endfunction()

# octetra_mpi_flags(<cflags> <libraries>): the flags that stand for MPI where it has no package.
function(octetra_mpi_flags cflags libraries)
  list(TRANSFORM MPI_CXX_INCLUDE_DIRS PREPEND -I OUTPUT_VARIABLE folders)
  set(${cflags} ${folders} PARENT_SCOPE)
  set(${libraries} ${MPI_CXX_LIBRARIES} PARENT_SCOPE)
endfunction()
