// Is a classic netCDF file as long as its header says? The library reads what is missing as zeros and says nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace strut::io {

constexpr std::int64_t all_records = std::numeric_limits<std::int64_t>::max();

// "" for a file that is whole, and for HDF5 files, which the library checks itself; else what is wrong with it. Whole:
// up to so many records, where what follows them is not asked for.
std::string classic_netcdf_problem(const std::filesystem::path& path, std::int64_t records = all_records);

// So many records are left of those that the file has. Throws Error.
void keep_records(const std::filesystem::path& path, int count);

}  // namespace strut::io
