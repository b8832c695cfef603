// A sheet that is drawn on like a canvas and is an SVG: the same layers make both.

const EMPTY = {
  fillStyle: "#000",
  strokeStyle: "#000",
  lineWidth: 1,
  globalAlpha: 1,
  lineCap: "butt",
  lineJoin: "miter",
  font: "10px sans-serif",
  textAlign: "start",
  textBaseline: "alphabetic",
};
const ANCHOR: Record<string, string> = { center: "middle", right: "end", end: "end" };
const SHIFT: Record<string, number> = { middle: 0.35, top: 0.8, hanging: 0.8, bottom: -0.2 }; // of the font's size

/** What the layers use of a canvas context. Text may be turned, and everything moved and scaled evenly. */
export class SvgPaper {
  fillStyle = EMPTY.fillStyle;
  strokeStyle = EMPTY.strokeStyle;
  lineWidth = EMPTY.lineWidth;
  globalAlpha = EMPTY.globalAlpha;
  lineCap = EMPTY.lineCap;
  lineJoin = EMPTY.lineJoin;
  font = EMPTY.font;
  textAlign = EMPTY.textAlign;
  textBaseline = EMPTY.textBaseline;
  private readonly parts: string[] = [];
  private readonly clips: string[] = [];
  private readonly stack: { style: Record<string, unknown>; depth: number; dash: number[]; turns: string[] }[] = [];
  private path = "";
  private dash: number[] = [];
  private turns: string[] = [];
  private depth = 0; // groups that are open

  constructor(
    private readonly width: number,
    private readonly height: number,
    private readonly measure: CanvasRenderingContext2D, // which knows how long words are
  ) {}

  /** As the layers take it. */
  get context(): CanvasRenderingContext2D {
    return this as unknown as CanvasRenderingContext2D;
  }

  get text(): string {
    const size = `width="${this.width}" height="${this.height}" viewBox="0 0 ${this.width} ${this.height}"`;
    return `<svg xmlns="http://www.w3.org/2000/svg" ${size} font-family="system-ui, sans-serif"><defs>${this.clips.join("")}</defs>${this.parts.join("")}${"</g>".repeat(this.depth)}</svg>\n`;
  }

  beginPath(): void {
    this.path = "";
  }
  moveTo(x: number, y: number): void {
    this.path += `M${n(x)} ${n(y)}`;
  }
  lineTo(x: number, y: number): void {
    this.path += `${this.path ? "L" : "M"}${n(x)} ${n(y)}`;
  }
  closePath(): void {
    this.path += "Z";
  }
  rect(x: number, y: number, w: number, h: number): void {
    this.path += `M${n(x)} ${n(y)}h${n(w)}v${n(h)}h${n(-w)}Z`;
  }
  quadraticCurveTo(a: number, b: number, x: number, y: number): void {
    this.path += `Q${n(a)} ${n(b)} ${n(x)} ${n(y)}`;
  }
  bezierCurveTo(a: number, b: number, c: number, d: number, x: number, y: number): void {
    this.path += `C${n(a)} ${n(b)} ${n(c)} ${n(d)} ${n(x)} ${n(y)}`;
  }

  arc(x: number, y: number, r: number, from: number, to: number): void {
    const point = (angle: number): string => `${n(x + r * Math.cos(angle))} ${n(y + r * Math.sin(angle))}`;
    const middle = (from + to) / 2;
    const bow = `A${n(r)} ${n(r)} 0 ${Math.abs(to - from) / 2 > Math.PI ? 1 : 0} 1 `;
    this.path += `${this.path ? "L" : "M"}${point(from)}${bow}${point(middle)}${bow}${point(to)}`;
  }

  fill(): void {
    this.add(`<path d="${this.path}" fill="${this.fillStyle}"${this.opacity}/>`);
  }
  stroke(): void {
    this.add(`<path d="${this.path}" fill="none"${this.pen}/>`);
  }
  fillRect(x: number, y: number, w: number, h: number): void {
    this.add(`<rect ${box(x, y, w, h)} fill="${this.fillStyle}"${this.opacity}/>`);
  }
  strokeRect(x: number, y: number, w: number, h: number): void {
    this.add(`<rect ${box(x, y, w, h)} fill="none"${this.pen}/>`);
  }
  clearRect(): void {
    /* nothing is there yet */
  }
  setLineDash(dash: number[]): void {
    this.dash = dash;
  }
  measureText(words: string): TextMetrics {
    this.measure.font = this.font;
    return this.measure.measureText(words);
  }
  translate(x: number, y: number): void {
    this.turns.push(`translate(${n(x)} ${n(y)})`);
  }
  rotate(angle: number): void {
    this.turns.push(`rotate(${n((angle * 180) / Math.PI)})`);
  }
  scale(x: number, y: number): void {
    this.turns.push(`scale(${n(x)} ${n(y)})`);
  }
  strokeText(): void {
    /* halos of words are left out */
  }

  fillText(words: string, x: number, y: number): void {
    const [, weight, size] = /(?:(\d+) )?([\d.]+)px/.exec(this.font) ?? ["", "", "10"];
    const down = y + (SHIFT[this.textBaseline] ?? 0) * Number(size);
    const bold = weight ? ` font-weight="${weight}"` : "";
    this.add(
      `<text x="${n(x)}" y="${n(down)}" font-size="${size}"${bold} text-anchor="${ANCHOR[this.textAlign] ?? "start"}" fill="${this.fillStyle}"${this.opacity}>${escaped(words)}</text>`,
    );
  }

  clip(): void {
    const id = `c${this.clips.length}`;
    this.clips.push(`<clipPath id="${id}"><path d="${this.path}"/></clipPath>`);
    this.parts.push(`<g clip-path="url(#${id})">`);
    this.depth++;
  }

  save(): void {
    const style = Object.fromEntries(Object.keys(EMPTY).map((name) => [name, this[name as keyof typeof EMPTY]]));
    this.stack.push({ style, depth: this.depth, dash: this.dash, turns: [...this.turns] });
  }

  restore(): void {
    const saved = this.stack.pop();
    if (!saved) return;
    Object.assign(this, saved.style);
    [this.dash, this.turns] = [saved.dash, saved.turns];
    this.parts.push("</g>".repeat(this.depth - saved.depth));
    this.depth = saved.depth;
  }

  private add(part: string): void {
    this.parts.push(this.turns.length ? `<g transform="${this.turns.join(" ")}">${part}</g>` : part);
  }

  private get opacity(): string {
    return this.globalAlpha < 1 ? ` opacity="${n(this.globalAlpha)}"` : "";
  }

  private get pen(): string {
    const dash = this.dash.length ? ` stroke-dasharray="${this.dash.map(n).join(" ")}"` : "";
    const ends = `${this.lineCap === "butt" ? "" : ` stroke-linecap="${this.lineCap}"`}${this.lineJoin === "miter" ? "" : ` stroke-linejoin="${this.lineJoin}"`}`;
    return ` stroke="${this.strokeStyle}" stroke-width="${n(this.lineWidth)}"${dash}${ends}${this.opacity}`;
  }
}

const n = (value: number): string => String(Math.round(100 * value) / 100);
const box = (x: number, y: number, w: number, h: number): string => `x="${n(x)}" y="${n(y)}" width="${n(w)}" height="${n(h)}"`;

function escaped(words: string): string {
  return words.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}
