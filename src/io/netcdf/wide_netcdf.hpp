// A classic netCDF file with 64-bit sizes (CDF-5), whose variables may exceed 4 GB per record.
#pragma once

#include <filesystem>

namespace strut::io {

// Converts a file that has a header but no values yet. Throws Error.
void widen(const std::filesystem::path& path);

}  // namespace strut::io
