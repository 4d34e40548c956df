// Reading files that the library may not survive. HDF5 does not check all that it finds in a damaged file: it may write
// where it must not. So a copy of this process reads the file first; only where it comes through does this one.
#pragma once

#include <filesystem>
#include <functional>

namespace strut::io {

// For HDF5 files only; others are checked otherwise (classic_netcdf.hpp). Throws Error where the copy crashes, does not
// end or throws: the library, which leaves a damaged file open, never sees it in this process.
void try_in_child_process(const std::filesystem::path& file, const std::function<void()>& read);

template <class Read>
auto read_after_trial(const std::filesystem::path& file, const Read& read) {
  try_in_child_process(file, [&read] { read(); });
  return read();
}

// From now on, of this process: false where nothing may be forked (some networks under MPI); files are then trusted.
void set_trial_reads(bool wanted);

bool is_hdf5(const std::filesystem::path& file);

}  // namespace strut::io
