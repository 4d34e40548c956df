// A run, from deck to result.
#pragma once

#include <filesystem>

namespace strut {

class Communicator;

enum class Start { anew, continued };  // continued: from the checkpoint of an earlier run of the deck, if there is one

// Collective. Runs the deck, which names the files that it writes. Throws Error on all ranks. Returns false if a signal
// (SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU) or the deck's wall time ended it early, with a checkpoint and
// everything written so far readable.
bool run(const std::filesystem::path& deck, const Communicator& communicator, Start start = Start::anew);

// Collective. Validates the deck and its mesh and prints a forecast of the run: points, bonds, memory, critical time
// step, number of steps, time.
void check(const std::filesystem::path& deck, const Communicator& communicator);

}  // namespace strut
