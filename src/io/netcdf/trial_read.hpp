// Reads files that may crash the library. HDF5 does not check everything in a damaged file and may write to invalid
// memory. So a child process reads the file first, and this process only if that succeeds.
#pragma once

#include <filesystem>
#include <functional>

namespace strut::io {

// For HDF5 files only; others are checked directly (classic_netcdf.hpp). Throws Error if the child process crashes,
// does not end or throws: the library, which leaves damaged files open, never opens such a file in this process.
void try_in_child_process(const std::filesystem::path& file, const std::function<void()>& read);

template <class Read>
auto read_after_trial(const std::filesystem::path& file, const Read& read) {
  try_in_child_process(file, [&read] { read(); });
  return read();
}

// For this process from now on: false where fork is not possible (some networks under MPI); files are then trusted.
void set_trial_reads(bool wanted);

bool is_hdf5(const std::filesystem::path& file);

}  // namespace strut::io
