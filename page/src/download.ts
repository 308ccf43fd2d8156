// Files that the browser keeps as it keeps all downloads.
export function download(name: string, blob: Blob) {
    const href = URL.createObjectURL(blob);
    Object.assign(document.createElement("a"), { href, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(href), 10000);
}
