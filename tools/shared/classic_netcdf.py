"""The length of a classic netCDF file by its header (as in src/io/netcdf/classic_netcdf.cpp)."""
import os
import struct

SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}  # bytes of a number, by type
STREAMING = 0xffffffff  # number of records if the writer could not seek


class Header:
    def __init__(self, file, version):
        self.file = file
        self.count_form, self.offset_form = (">q" if version == 5 else ">I"), (">I" if version == 1 else ">q")

    def number(self, form=None):
        form = form or self.count_form
        data = self.file.read(struct.calcsize(form))
        return struct.unpack(form, data)[0]

    def skip(self, length):
        self.file.seek((length + 3) // 4 * 4, os.SEEK_CUR)

    def repeated(self, one):
        self.number(">I")  # the tag of the list
        return [one() for _ in range(self.number())]

    def dimension(self):
        self.skip(self.number())
        return self.number()

    def attribute(self):
        self.skip(self.number())
        size = SIZES[self.number(">I")]
        self.skip(self.number() * size)

    def variable(self, dimensions):
        """(whether it has an entry per record, bytes of one, its offset)"""
        self.skip(self.number())
        lengths = [dimensions[self.number()] for _ in range(self.number())]
        self.repeated(self.attribute)
        size = SIZES[self.number(">I")]
        for length in lengths:
            size *= length or 1
        self.number()  # the stored size, which wraps around for large variables
        return 0 in lengths, size, self.number(self.offset_form)

    def promised(self):
        """The file size that the header implies. Padding at the end may be unwritten."""
        records = self.number()
        dimensions = self.repeated(self.dimension)
        self.repeated(self.attribute)
        variables = self.repeated(lambda: self.variable(dimensions))
        record = sum((size + 3) // 4 * 4 for recorded, size, _ in variables if recorded)
        records = 0 if records == STREAMING else records
        ends = [place + size + ((records - 1) * record if recorded else 0)
                for recorded, size, place in variables if records or not recorded]
        return max(ends, default=0)


def problem(path):
    """The defect of the file; None: none, or no classic netCDF file, which netCDF itself checks."""
    with open(path, "rb") as file:
        magic = file.read(4)
        if magic[:3] != b"CDF" or magic[3:] not in (b"\1", b"\2", b"\5"):
            return None
        try:
            promised = Header(file, magic[3]).promised()
        except (struct.error, KeyError, IndexError, OSError, ValueError, OverflowError, MemoryError):
            return "its header is cut off or damaged"
    size = os.path.getsize(path)
    return None if size >= promised else f"it is cut off: {size} of {promised} bytes are there"
