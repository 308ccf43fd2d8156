// Scripts in the fragment of an address, which browsers do not send to servers.
import { all_of, from_base64, in_base64 } from "./base64";

const largest_script = 1 << 20;  ///< In bytes.

/// Compresses a script by zlib and encodes it in base64 for addresses.
export async function pack(text: string) {
    const packed = await new Response(new Blob([text]).stream().pipeThrough(new CompressionStream("deflate"))).blob();
    return (await in_base64(packed)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/// The script in the address of the page, or undefined if there is none. Throws if it cannot be
/// read.
export async function script_of_address() {
    const packed = new URLSearchParams(location.hash.slice(1)).get("script");
    if (!packed) return undefined;
    const bytes = new Blob([from_base64(packed.replaceAll("-", "+").replaceAll("_", "/"))]);
    return new TextDecoder().decode(await all_of(bytes.stream().pipeThrough(new DecompressionStream("deflate")), largest_script));
}

export const wrong_link = { is_error: true, message: "the script in the address cannot be read", hint: "the link was cut off or changed, or its script has more than 1 MiB" };
