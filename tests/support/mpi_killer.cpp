/// To be preloaded (LD_PRELOAD) into a program under mpirun: rank OCTETRA_KILL_RANK kills itself at
/// its MPI call number OCTETRA_KILL_AT, from 1. Only calls that send, wait or are collective count,
/// so that the number does not depend on timing. With 0 the rank is not killed, and reports its
/// number of calls on stderr. Wraps MPI through the profiling interface, PMPI.

#include "support/preloaded.hpp"

#include <mpi.h>

#include <csignal>
#include <cstdio>

namespace {

using octetra::preloaded::is_rank_in_environment;
using octetra::preloaded::number_in_environment;

class Victim {
public:
    Victim() = default;
    Victim(const Victim&) = delete;
    Victim& operator=(const Victim&) = delete;
    Victim(Victim&&) = delete;
    Victim& operator=(Victim&&) = delete;
    ~Victim() {
        if (is_this_one_ && kill_at_ == 0) std::fprintf(stderr, "calls of MPI: %d\n", calls_);
    }
    void call() {
        if (calls_ == 0) is_this_one_ = is_rank_in_environment("OCTETRA_KILL_RANK");
        ++calls_;
        if (is_this_one_ && calls_ == kill_at_) std::raise(SIGKILL);
    }

private:
    bool is_this_one_ = false;
    int kill_at_ = number_in_environment("OCTETRA_KILL_AT");
    int calls_ = 0;
};

Victim victim;

}  // namespace

int MPI_Isend(const void* buffer, int count, MPI_Datatype type, int receiver, int tag,
              MPI_Comm comm, MPI_Request* request) {
    victim.call();
    return PMPI_Isend(buffer, count, type, receiver, tag, comm, request);
}

int MPI_Issend(const void* buffer, int count, MPI_Datatype type, int receiver, int tag,
               MPI_Comm comm, MPI_Request* request) {
    victim.call();
    return PMPI_Issend(buffer, count, type, receiver, tag, comm, request);
}

int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
    victim.call();
    return PMPI_Ibarrier(comm, request);
}

int MPI_Mprobe(int sender, int tag, MPI_Comm comm, MPI_Message* message, MPI_Status* status) {
    victim.call();
    return PMPI_Mprobe(sender, tag, comm, message, status);
}

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
    victim.call();
    return PMPI_Waitall(count, requests, statuses);
}

int MPI_Allreduce(const void* mine, void* result, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm) {
    victim.call();
    return PMPI_Allreduce(mine, result, count, type, operation, comm);
}

int MPI_Exscan(const void* mine, void* result, int count, MPI_Datatype type, MPI_Op operation,
               MPI_Comm comm) {
    victim.call();
    return PMPI_Exscan(mine, result, count, type, operation, comm);
}

int MPI_Bcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    victim.call();
    return PMPI_Bcast(buffer, count, type, root, comm);
}

int MPI_Allgather(const void* mine, int count, MPI_Datatype type, void* all, int each,
                  MPI_Datatype type_of_all, MPI_Comm comm) {
    victim.call();
    return PMPI_Allgather(mine, count, type, all, each, type_of_all, comm);
}

int MPI_Allgatherv(const void* mine, int count, MPI_Datatype type, void* all, const int* counts,
                   const int* places, MPI_Datatype type_of_all, MPI_Comm comm) {
    victim.call();
    return PMPI_Allgatherv(mine, count, type, all, counts, places, type_of_all, comm);
}
