#include "support/mpi_counter.hpp"

#include <mpi.h>

#include <chrono>

namespace octetra::test {
namespace {

MpiCounts& counts() {
    static MpiCounts all;
    return all;
}

std::uint64_t bytes_of(int count, MPI_Datatype type) {
    int size = 0;
    PMPI_Type_size(type, &size);
    return static_cast<std::uint64_t>(count) * static_cast<std::uint64_t>(size);
}

int timed(auto&& call) {
    const auto start = std::chrono::steady_clock::now();
    const int result = call();
    counts().nanoseconds +=
        std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
    return result;
}

int message(int count, MPI_Datatype type, auto&& call) {
    ++counts().messages;
    counts().bytes += bytes_of(count, type);
    return timed(call);
}

int collective(int count, MPI_Datatype type, auto&& call) {
    ++counts().collectives;
    counts().collective_bytes += bytes_of(count, type);
    return timed(call);
}

}  // namespace

MpiCounts mpi_counts() { return counts(); }

}  // namespace octetra::test

using octetra::test::collective;
using octetra::test::message;
using octetra::test::timed;

// The MPI functions that the engine calls and that take time.

int MPI_Isend(const void* buffer, int count, MPI_Datatype type, int receiver, int tag,
              MPI_Comm comm, MPI_Request* request) {
    return message(count, type,
                   [&] { return PMPI_Isend(buffer, count, type, receiver, tag, comm, request); });
}

int MPI_Issend(const void* buffer, int count, MPI_Datatype type, int receiver, int tag,
               MPI_Comm comm, MPI_Request* request) {
    return message(count, type,
                   [&] { return PMPI_Issend(buffer, count, type, receiver, tag, comm, request); });
}

int MPI_Improbe(int sender, int tag, MPI_Comm comm, int* has_arrived, MPI_Message* message,
                MPI_Status* status) {
    return timed([&] { return PMPI_Improbe(sender, tag, comm, has_arrived, message, status); });
}

int MPI_Mprobe(int sender, int tag, MPI_Comm comm, MPI_Message* message, MPI_Status* status) {
    return timed([&] { return PMPI_Mprobe(sender, tag, comm, message, status); });
}

int MPI_Mrecv(void* buffer, int count, MPI_Datatype type, MPI_Message* message,
              MPI_Status* status) {
    return timed([&] { return PMPI_Mrecv(buffer, count, type, message, status); });
}

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
    return timed([&] { return PMPI_Waitall(count, requests, statuses); });
}

int MPI_Testall(int count, MPI_Request* requests, int* are_over, MPI_Status* statuses) {
    return timed([&] { return PMPI_Testall(count, requests, are_over, statuses); });
}

int MPI_Test(MPI_Request* request, int* is_over, MPI_Status* status) {
    return timed([&] { return PMPI_Test(request, is_over, status); });
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
    return collective(0, MPI_BYTE, [&] { return PMPI_Ibarrier(comm, request); });
}

int MPI_Allreduce(const void* mine, void* result, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm) {
    return collective(count, type,
                      [&] { return PMPI_Allreduce(mine, result, count, type, operation, comm); });
}

int MPI_Exscan(const void* mine, void* result, int count, MPI_Datatype type, MPI_Op operation,
               MPI_Comm comm) {
    return collective(count, type,
                      [&] { return PMPI_Exscan(mine, result, count, type, operation, comm); });
}

int MPI_Bcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    return collective(count, type, [&] { return PMPI_Bcast(buffer, count, type, root, comm); });
}

int MPI_Allgather(const void* mine, int count, MPI_Datatype type, void* all, int each,
                  MPI_Datatype type_of_all, MPI_Comm comm) {
    return collective(count, type, [&] {
        return PMPI_Allgather(mine, count, type, all, each, type_of_all, comm);
    });
}

int MPI_Allgatherv(const void* mine, int count, MPI_Datatype type, void* all, const int* counts,
                   const int* places, MPI_Datatype type_of_all, MPI_Comm comm) {
    return collective(count, type, [&] {
        return PMPI_Allgatherv(mine, count, type, all, counts, places, type_of_all, comm);
    });
}
