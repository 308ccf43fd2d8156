// Groups of the library and similarity of its systems, by the words of their descriptions.

/// The groups, and words that are typical of their systems. A system belongs to the group whose
/// words occur most often in its description, or to the first of several such groups.
const groups: [name: string, words: string][] = [
    ["Spots and stripes", "turing spot spots stripe stripes labyrinth labyrinths dot dots hexagon hexagons skin skins digit digits phyllotaxis nanocoating brusselator schnakenberg swift superlattice holes squares worms mitosis inhibition inhibitor coats"],
    ["Waves and spirals", "wave waves spiral spirals excitable heart front fronts pulse pulses clock gliders turbulence chaos glycolysis ginzburg lambda oscillations travelling epidemic"],
    ["Life", "prey predator predators plants water bacteria bacterial competition cyclic colony species lung tumour chemotaxis invasion scissors bush vegetation infected embryo"],
    ["Growth and phases", "phase phases crystal dendrite aggregation cracks cluster walls lightning alloy grains cahn porous ballistic kardar"],
    ["Physics", "heat viscosity shock soliton solitons korteweg sine quantum schrödinger shallow brightness vortices burgers kuramoto perona"],
];
const of_others = "Others", of_examples = "Examples";

export const favourites = "Favourites";
export const group_names = [favourites, ...groups.map(([name]) => name), of_others, of_examples];

const words_of = (text: string) => text.toLowerCase().match(/[\p{L}]{3,}/gu) ?? [];

/// Words in `title` count twice.
export function group_of(title: string, about: string, is_example: boolean): string {
    if (is_example) return of_examples;
    const told = words_of(`${title} ${title} ${about}`);
    const counts = groups.map(([, words]) => told.filter((word) => words.split(" ").includes(word)).length), most = Math.max(...counts);
    return most > 0 ? groups[counts.indexOf(most)][0] : of_others;
}

/// The similarity of each text to text `to`, 0 … 1: the cosine of the angle between sets of words, in which rare words
/// have more weight.
export function likeness(texts: string[], to: number): number[] {
    // Plurals count as the same words.
    const sets = texts.map((text) => new Set(words_of(text).map((word) => word.replace(/s$/, "")))), count = new Map<string, number>();
    for (const set of sets) for (const word of set) count.set(word, (count.get(word) ?? 0) + 1);
    const weight = (word: string) => Math.log(texts.length / count.get(word)!) ** 2;
    const size = (words: Iterable<string>) => [...words].reduce((sum, word) => sum + weight(word), 0);
    const sizes = sets.map(size);
    return sets.map((set, k) => size([...set].filter((word) => sets[to].has(word))) / (Math.sqrt(sizes[k] * sizes[to]) || 1));
}
