// How the page writes numbers and messages.
import type { Message } from "./connection";

export const digits = (value: number) => String(Number(value.toPrecision(4)));

export const in_words = ({ from, message, hint }: Message) => `${from ? `line ${from[0]}: ` : ""}${message}${hint ? ` – ${hint}` : ""}`;
