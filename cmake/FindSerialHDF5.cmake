# SerialHDF5::SerialHDF5: the C library of HDF5 built without MPI (Debian: libhdf5-dev). CMake's own
# module may find the parallel library if both are installed, and then requires MPI.
find_path(SerialHDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(SerialHDF5_LIBRARY NAMES hdf5_serial hdf5)
if(SerialHDF5_INCLUDE_DIR)
  file(STRINGS ${SerialHDF5_INCLUDE_DIR}/H5pubconf.h SerialHDF5_has_mpi REGEX "define H5_HAVE_PARALLEL")
  if(SerialHDF5_has_mpi)
    set(SerialHDF5_INCLUDE_DIR SerialHDF5_INCLUDE_DIR-NOTFOUND)
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SerialHDF5
  REQUIRED_VARS SerialHDF5_LIBRARY SerialHDF5_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "HDF5 without MPI is required (Debian: libhdf5-dev)")
if(SerialHDF5_FOUND AND NOT TARGET SerialHDF5::SerialHDF5)
  add_library(SerialHDF5::SerialHDF5 UNKNOWN IMPORTED)
  set_target_properties(SerialHDF5::SerialHDF5 PROPERTIES
    IMPORTED_LOCATION ${SerialHDF5_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${SerialHDF5_INCLUDE_DIR})
endif()
mark_as_advanced(SerialHDF5_INCLUDE_DIR SerialHDF5_LIBRARY)
