"""The container of an index file: its header and its sections, with what they hold as bytes or as images."""

import struct
import zlib

import numpy
import xxhash
import zstandard

MAGIC = bytes.fromhex("89474944580D0A1A")
RAW, ZSTD, PNG, IMAGES = 0, 1, 2, 3
RUN = 1 << 18


class Refused(Exception):
    pass


def require(condition, message):
    if not condition:
        raise Refused(message)


class Section:
    def __init__(self, codec, stored, raw_size):
        self.codec, self.stored, self.raw_size = codec, stored, raw_size

    def bytes(self):
        if self.codec == RAW:
            return self.stored
        if self.codec == IMAGES:
            return self._runs()
        require(self.codec == ZSTD, "a section of bytes is png")
        return zstandard.ZstdDecompressor().decompress(self.stored, max_output_size=self.raw_size)

    def matrices(self, shapes):
        """One array for each (rows, columns), in order; matrices of nothing are not stored."""
        shapes = [shape for shape in shapes if 0 not in shape]
        if self.codec == PNG:
            return [floats_of(image) for image in self._images(shapes, RGBA)]
        entries, matrices = numpy.frombuffer(self.bytes(), "<f4"), []
        for rows, columns in shapes:
            matrices.append(entries[: rows * columns].reshape(rows, columns))
            entries = entries[rows * columns :]
        require(len(entries) == 0, "entries are left over")
        return matrices

    def _runs(self):
        rest = self.raw_size % RUN
        shapes = [(32, 8192)] * (self.raw_size // RUN) + ([(1, rest)] if rest else [])
        return b"".join(image.tobytes() for image in self._images(shapes, GRAY))

    def _images(self, shapes, color):
        (count,) = struct.unpack_from("<I", self.stored)
        require(count == len(shapes), "another number of images")
        lengths = struct.unpack_from(f"<{count}Q", self.stored, 4)
        at, images = 4 + 8 * count, []
        for length, shape in zip(lengths, shapes):
            images.append(decode_png(self.stored[at : at + length], shape, color))
            at += length
        require(at == len(self.stored), "streams do not fill their section")
        return images


def read_sections(content):
    require(content[:8] == MAGIC, "not an index")
    major, _, _, _, count, file_size, fingerprint, checksum = struct.unpack_from("<HHIIIQQQ", content, 8)
    require(major == 2 and file_size == len(content), "another version or size")
    head = bytearray(content[: 48 + 48 * count])
    head[40:48] = bytes(8)
    require(xxhash.xxh3_64_intdigest(bytes(head)) == checksum, "the header's checksum does not match")
    sections, end = {}, len(head)
    for i in range(count):
        tag, codec, _, _, offset, size, raw_size, checksum = struct.unpack_from("<4sIIIQQQQ", content, 48 + 48 * i)
        require(offset == (end + 63) // 64 * 64 and not any(content[end:offset]), "a section out of its place")
        stored, end = content[offset : offset + size], offset + size
        require(xxhash.xxh3_64_intdigest(stored) == checksum, f"the checksum of {tag} does not match")
        sections[tag.decode()] = Section(codec, stored, raw_size)
    require(end == file_size, "bytes behind the last section")
    return sections, fingerprint


# ---- PNG


GRAY, RGBA = (0, 1), (6, 4)  # color type, bytes a pixel


def floats_of(image):
    """The matrix of float32 in the pixels of an RGBA image."""
    return image.reshape(image.shape[0], -1, 4).view(">f4")[..., 0].astype("f4")


def decode_png(stream, shape, color):
    """The lines of an image of 8 bits a channel."""
    data, at = b"", 8
    while at < len(stream):
        length, kind = struct.unpack_from(">I4s", stream, at)
        body = stream[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color_type, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            require((height, width) == shape and (depth, color_type, interlaced) == (8, color[0], 0), "another kind of image")
        if kind == b"IDAT":
            data += body
        at += 12 + length
    return unfilter(zlib.decompress(data), *shape, color[1])


def unfilter(data, height, width, pixel):
    stride = pixel * width
    lines, before = numpy.empty((height, stride), "u1"), numpy.zeros(stride, "u1")
    for r in range(height):
        kind = data[r * (stride + 1)]
        line = numpy.frombuffer(data, "u1", stride, r * (stride + 1) + 1)
        lines[r] = before = unfilter_line(kind, line, before, pixel)
    return lines


def unfilter_line(kind, line, above, pixel):
    if kind == 0:
        return line
    if kind == 1:
        return line.reshape(-1, pixel).cumsum(axis=0, dtype="u1").reshape(-1)
    if kind == 2:
        return line + above
    predict = average if kind == 3 else paeth
    # The pixel left of the line is zero, as the format wants it.
    out, above = bytearray(pixel), bytes(pixel) + above.tobytes()
    for i, value in enumerate(line.tobytes(), pixel):
        out.append(value + predict(out[i - pixel], above[i], above[i - pixel]) & 0xFF)
    return numpy.frombuffer(bytes(out[pixel:]), "u1")


def average(left, up, _):
    return (left + up) // 2


def paeth(left, up, up_left):
    guess = left + up - up_left
    return min((left, up, up_left), key=lambda byte: abs(guess - byte))
