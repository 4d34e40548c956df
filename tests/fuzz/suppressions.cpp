// Memory that netCDF loses where a file turns out to be damaged is not ours to free. That we close what we open is seen
// by the open files (worker.cpp).
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libnetcdf\nleak:libmpi\nleak:libopen-pal\n"; }
