// Makes ZIP files without compression, since PNG files are compressed already.
export interface ZippedFile { name: string; bytes: Uint8Array }

const remainders = Uint32Array.from({ length: 256 }, (_, byte) => {
    let value = byte;
    for (let bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
    return value;
});

function crc32(bytes: Uint8Array): number {
    let value = 0xffffffff;
    for (const byte of bytes) value = remainders[(value ^ byte) & 255] ^ (value >>> 8);
    return (value ^ 0xffffffff) >>> 0;
}

/// The bytes of numbers of 2 or 4 bytes, least significant byte first.
function numbers(...parts: [number, 2 | 4][]): Uint8Array {
    const bytes = new Uint8Array(parts.reduce((sum, [, size]) => sum + size, 0)), view = new DataView(bytes.buffer);
    let at = 0;
    for (const [value, size] of parts) {
        if (size === 2) view.setUint16(at, value, true);
        else view.setUint32(at, value, true);
        at += size;
    }
    return bytes;
}

/// Names must be ASCII. There may be at most 65,535 files and 4 GiB.
export function zip(files: ZippedFile[]): Blob {
    const parts: Uint8Array[] = [], list: Uint8Array[] = [], day = 1 << 5 | 1;  // The first day of ZIP's calendar.
    let at = 0;
    const add = (...pieces: Uint8Array[]) => {
        for (const piece of pieces) at += piece.length;
        parts.push(...pieces);
    };
    for (const { name, bytes } of files) {
        const begin = at, path = new TextEncoder().encode(name);
        const about = numbers([20, 2], [0, 2], [0, 2], [0, 2], [day, 2], [crc32(bytes), 4], [bytes.length, 4], [bytes.length, 4], [path.length, 2], [0, 2]);
        add(numbers([0x04034b50, 4]), about, path, bytes);
        list.push(numbers([0x02014b50, 4], [20, 2]), about, numbers([0, 2], [0, 2], [0, 2], [0, 4], [begin, 4]), path);
    }
    const begin = at;
    add(...list);
    add(numbers([0x06054b50, 4], [0, 2], [0, 2], [files.length, 2], [files.length, 2], [at - begin, 4], [begin, 4], [0, 2]));
    return new Blob(parts as BlobPart[], { type: "application/zip" });
}
