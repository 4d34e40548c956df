// A classic netCDF file with 64-bit sizes (CDF-5), of which a variable may have more than 4 GB in a record.
#pragma once

#include <filesystem>

namespace strut::io {

// Makes such a file of one that has a header, but no values yet. Throws Error.
void widen(const std::filesystem::path& path);

}  // namespace strut::io
