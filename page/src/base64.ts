// Base64, in which messages and addresses contain bytes.

export const in_base64 = (blob: Blob) => new Promise<string>((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve((reader.result as string).split(",")[1] ?? "");
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
});

export const from_base64 = (text: string) => Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));

/// All bytes of a stream. Throws if there are more than `largest`.
export async function all_of(stream: ReadableStream<Uint8Array<ArrayBuffer>>, largest = Infinity) {
    const reader = stream.getReader(), parts: Uint8Array<ArrayBuffer>[] = [];
    for (let size = 0, part = await reader.read(); !part.done; part = await reader.read()) {
        size += part.value.length;
        if (size > largest) throw new Error(`there are more than ${largest} bytes`);
        parts.push(part.value);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}
