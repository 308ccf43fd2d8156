// Measures the latency and the bandwidth of messages between two ranks, for bench/ranks_model.py:
//
//   mpicxx -O2 bench/ranks_ping.cpp -o ping && mpiexec -n 2 ./ping
//
// Prints the least times of many exchanges, because other programs only make them longer.
#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

/// Half the least time, in seconds, in which a message of `bytes` goes to the other rank and back.
double least_time(int rank, int bytes, int count) {
    std::vector<char> message(static_cast<std::size_t>(bytes));
    double least = 1e9;
    for (int k = 0; k < count; ++k) {
        const double begin = MPI_Wtime();
        if (rank == 0) {
            MPI_Send(message.data(), bytes, MPI_BYTE, 1, 0, MPI_COMM_WORLD);
            MPI_Recv(message.data(), bytes, MPI_BYTE, 1, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        } else if (rank == 1) {
            MPI_Recv(message.data(), bytes, MPI_BYTE, 0, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            MPI_Send(message.data(), bytes, MPI_BYTE, 0, 0, MPI_COMM_WORLD);
        }
        least = std::min(least, MPI_Wtime() - begin);
    }
    return least / 2;
}

}  // namespace

int main(int count, char** words) {
    MPI_Init(&count, &words);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const double latency = least_time(rank, 1, 20000);
    constexpr int large = 1 << 22;
    const double seconds = least_time(rank, large, 500);
    if (rank == 0) {
        std::printf("latency %.2f us, bandwidth %.2f GB/s\n", 1e6 * latency, large / seconds / 1e9);
    }
    MPI_Finalize();
    return 0;
}
