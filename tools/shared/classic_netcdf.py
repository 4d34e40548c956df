"""The length of a classic netCDF file by its header (as in src/io/netcdf/classic_netcdf.cpp)."""
import math
import os
import struct

SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}  # bytes of a number, by type
STREAMING = 0xffffffff  # number of records if the writer could not seek


def promised(file, version):
    """The file size that the header implies. Padding at the end may be unwritten."""
    count_form, offset_form = (">q" if version == 5 else ">I"), (">I" if version == 1 else ">q")

    def number(form=count_form):
        return struct.unpack(form, file.read(struct.calcsize(form)))[0]

    def skip(length):
        file.seek((length + 3) // 4 * 4, os.SEEK_CUR)

    def repeated(one):
        number(">I")  # the tag of the list
        return [one() for _ in range(number())]

    def dimension():
        skip(number())
        return number()

    def attribute():
        skip(number())
        skip(SIZES[number(">I")] * number())

    def variable():
        skip(number())
        lengths = [dimensions[number()] for _ in range(number())]
        repeated(attribute)
        size = SIZES[number(">I")] * math.prod(length or 1 for length in lengths)
        number()  # the stored size, which wraps around for large variables
        return 0 in lengths, size, number(offset_form)  # whether it has an entry per record, bytes of one, its offset

    records, dimensions = number(), repeated(dimension)
    repeated(attribute)
    variables = repeated(variable)
    record = sum((size + 3) // 4 * 4 for recorded, size, _ in variables if recorded)
    records = 0 if records == STREAMING else records
    return max((place + size + ((records - 1) * record if recorded else 0)
                for recorded, size, place in variables if records or not recorded), default=0)


def problem(path):
    """The defect of the file; None: none, or no classic netCDF file, which netCDF itself checks."""
    with open(path, "rb") as file:
        magic = file.read(4)
        if magic[:3] != b"CDF" or magic[3:] not in (b"\1", b"\2", b"\5"):
            return None
        try:
            expected = promised(file, magic[3])
        except (struct.error, KeyError, IndexError, OSError, ValueError, OverflowError, MemoryError):
            return "its header is cut off or damaged"
    size = os.path.getsize(path)
    return None if size >= expected else f"it is cut off: {size} of {expected} bytes are there"
