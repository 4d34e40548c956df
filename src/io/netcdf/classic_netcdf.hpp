// Is a classic netCDF file as long as its header says? The library reads what is missing as zeros and says nothing.
#pragma once

#include <filesystem>
#include <string>

namespace strut::io {

// "" for a file that is whole, and for HDF5 files, which the library checks itself; else what is wrong with it.
std::string classic_netcdf_problem(const std::filesystem::path& path);

// Of a whole file: so many records are left of those that it has. Throws Error.
void keep_records(const std::filesystem::path& path, int count);

}  // namespace strut::io
