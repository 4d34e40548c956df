// Checks that a classic netCDF file is as long as its header says: the library silently reads missing data as zeros.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace strut::io {

constexpr std::int64_t all_records = std::numeric_limits<std::int64_t>::max();

// "" for a complete file, and for HDF5 files, which the library checks itself; else a description of the defect.
// Complete: up to `records` records, if later ones are not needed.
std::string classic_netcdf_problem(const std::filesystem::path& path, std::int64_t records = all_records);

bool is_hdf5(const std::filesystem::path& file);

// Truncates the file to its first `count` records. Throws Error.
void keep_records(const std::filesystem::path& path, int count);

}  // namespace strut::io
