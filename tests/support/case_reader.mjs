// Reads the files that tests/support/case_file.h writes: numbers of 32 bits, and lists of bytes
// that follow their lengths.
export class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.place = 0;
  }
  get isAtEnd() { return this.place === this.bytes.length; }
  number() {
    this.place += 4;
    return this.bytes.readUInt32LE(this.place - 4);
  }
  list() {
    const length = this.number();
    this.place += length;
    return this.bytes.subarray(this.place - length, this.place);
  }
}
