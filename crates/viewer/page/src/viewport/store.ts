// Tables of numbers on the GPU: textures of a fixed width that shaders read by row with `texelFetch`. A table
// grows when more rows are needed and is never smaller than one row. Filled by `skin`, `arrows` and
// `obstacles`; read by `shaders`.

import {
  DataTexture,
  FloatType,
  NearestFilter,
  type PixelFormat,
  type PixelFormatGPU,
  RedFormat,
  RedIntegerFormat,
  RGBAFormat,
  RGBAIntegerFormat,
  RGBFormat,
  UnsignedByteType,
  UnsignedIntType,
} from "three";

/** Rows of a table in one line of its texture; a power of two, as `shaders` takes it apart by bits. */
export const WIDTH = 2048;

/** A value that is none: larger than any that is shown. */
export const NONE = 3e38;

type Numbers = Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer> | Uint8Array<ArrayBuffer>;

interface Layout {
  channels: 1 | 3 | 4;
  internal: PixelFormatGPU;
  make: (count: number) => Numbers;
}

const LAYOUTS = {
  vector: { channels: 3, internal: "RGB32F", make: (count: number) => new Float32Array(count) },
  value: { channels: 1, internal: "R32F", make: (count: number) => new Float32Array(count) },
  index: { channels: 1, internal: "R32UI", make: (count: number) => new Uint32Array(count) },
  corners: { channels: 4, internal: "RGBA32UI", make: (count: number) => new Uint32Array(count) },
  colour: { channels: 4, internal: "RGBA8", make: (count: number) => new Uint8Array(count) },
} as const satisfies Record<string, Layout>;

function formatOf(layout: Layout): PixelFormat {
  const whole = layout.internal.endsWith("UI");
  if (layout.channels === 4) return whole ? RGBAIntegerFormat : RGBAFormat;
  if (layout.channels === 3) return RGBFormat;
  return whole ? RedIntegerFormat : RedFormat;
}

export class Table {
  texture: DataTexture;
  private data: Numbers;
  private readonly layout: Layout;

  constructor(kind: keyof typeof LAYOUTS) {
    this.layout = LAYOUTS[kind];
    this.data = this.layout.make(this.layout.channels * WIDTH);
    this.texture = this.made(1);
  }

  private made(lines: number): DataTexture {
    const layout = this.layout;
    const type = layout.internal === "RGBA8" ? UnsignedByteType : layout.internal.endsWith("UI") ? UnsignedIntType : FloatType;
    const texture = new DataTexture(this.data, WIDTH, lines, formatOf(layout), type);
    texture.internalFormat = layout.internal;
    texture.minFilter = NearestFilter;
    texture.magFilter = NearestFilter;
    texture.generateMipmaps = false;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    return texture;
  }

  /** Makes room for `rows` and gives the numbers to be filled; `send` when they are. */
  room(rows: number): Numbers {
    const lines = Math.max(1, Math.ceil(rows / WIDTH));
    const count = lines * WIDTH * this.layout.channels;
    if (count > this.data.length || 4 * count < this.data.length) {
      this.texture.dispose();
      this.data = this.layout.make(count);
      this.texture = this.made(lines);
    }
    return this.data;
  }

  /** The filled numbers go to the GPU with the next draw. */
  send(): void {
    this.texture.needsUpdate = true;
  }

  /** Takes numbers over as they are. */
  set(numbers: Float32Array | Uint32Array | Uint8Array): void {
    this.room(Math.ceil(numbers.length / this.layout.channels)).set(numbers);
    this.send();
  }

  /** Takes values over; what is not a finite number becomes `NONE`. */
  setValues(numbers: Float32Array): void {
    const data = this.room(numbers.length);
    for (let i = 0; i < numbers.length; i++) {
      const value = numbers[i]!;
      data[i] = value > -NONE && value < NONE ? value : NONE;
    }
    this.send();
  }

  dispose(): void {
    this.texture.dispose();
  }
}
