# For a cross compiler of Debian, with the libraries of arm64 beside those of the machine; ./dev campaign platforms
# makes such a system.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
# The compiler wrapper is that of the machine.
set(MPI_CXX_COMPILER MPI_CXX_COMPILER-NOTFOUND)
set(MPI_CXX_LIB_NAMES mpi)
set(MPI_mpi_LIBRARY /usr/lib/aarch64-linux-gnu/openmpi/lib/libmpi.so)
set(MPI_CXX_HEADER_DIR /usr/lib/aarch64-linux-gnu/openmpi/include)
set(MPI_CXX_COMPILER_INCLUDE_DIRS /usr/lib/aarch64-linux-gnu/openmpi/include)
