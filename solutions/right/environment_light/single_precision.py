"""Sums, edges and directions of single precision, as far as that is enough."""

import numpy as np


def texel_weights(image):
    """By the heights of the rows' edges."""
    if np.ndim(image) != 3 or np.shape(image)[2] != 3 or not np.size(image):
        raise ValueError("image must have shape (H, W, 3)")
    if not (image >= 0).all():
        raise ValueError("image must be >= 0")
    heights = np.cos(np.linspace(0, np.pi, len(image) + 1))
    per_texel = -np.diff(heights) * (2 * np.pi / image.shape[1])
    power = np.einsum("ijk,i->ij", image.astype(np.float64), per_texel)
    return (power / 3).astype(image.dtype)


def sample_direction(rows, columns, u):
    """By the smallest sum that is larger, row by row of the picture."""
    if np.ndim(columns) != 2 or np.shape(rows) != np.shape(columns)[:1]:
        raise ValueError("rows and columns must have shapes (H,) and (H, W)")
    if np.ndim(u) != 2 or np.shape(u)[0] != 2:
        raise ValueError("u must have shape (2, N)")
    height, width = columns.shape
    i = (rows[:, None] <= u[0]).sum(axis=0)
    j = (columns[i] <= u[1][:, None]).sum(axis=1)
    rows = np.concatenate(([0], rows))
    columns = np.concatenate((np.zeros((height, 1)), columns), axis=1)
    down = (u[0] - rows[i]) / (rows[i + 1] - rows[i])
    along = (u[1] - columns[i, j]) / (columns[i, j + 1] - columns[i, j])
    edge = np.cos(np.linspace(0, np.pi, height + 1))
    y = (edge[i] * (1 - down) + edge[i + 1] * down).astype(u.dtype)
    phi = ((j + along) * (2 * np.pi / width) - np.pi).astype(u.dtype)
    ring = np.sqrt(np.maximum(1 - y * y, 0))
    direction = np.stack((ring * np.sin(phi), y, -ring * np.cos(phi)))
    return direction / np.linalg.norm(direction, axis=0)


def draw_alias(probability, alias, u):
    """With divmod."""
    if np.ndim(probability) != 1 or np.shape(alias) != np.shape(probability):
        raise ValueError("probability and alias must have the same shape (K,)")
    if np.ndim(u) != 1:
        raise ValueError("u must have shape (N,)")
    k, f = np.divmod(u * np.float64(len(alias)), 1)
    k = k.astype(int)
    p = probability[k]
    other = f >= p
    with np.errstate(divide="ignore", invalid="ignore"):
        rest = np.where(other, (f - p) / (1 - p), f / p)
    return np.where(other, alias[k], k), np.clip(rest, 0, 1).astype(u.dtype)
