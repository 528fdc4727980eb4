//! Graphs of nodes and links: connected parts, and a numbering with a narrow band.

/// For each node the first node of the connected part that contains it.
pub(crate) fn connected_parts(nodes: usize, links: impl Iterator<Item = [usize; 2]>) -> Vec<usize> {
    let mut part: Vec<usize> = (0..nodes).collect();
    let root = |part: &[usize], mut node: usize| {
        while part[node] != node {
            node = part[node];
        }
        node
    };
    for link in links {
        let [a, b] = link.map(|node| root(&part, node));
        part[a.max(b)] = a.min(b);
    }
    (0..nodes).map(|node| root(&part, node)).collect()
}

/// Reverse Cuthill-McKee (1969; reversed George 1971): for each place in the numbering, its node.
///
/// A chain of beams is numbered from end to end.
pub(crate) fn narrow_band(nodes: usize, links: impl Iterator<Item = [usize; 2]>) -> Vec<usize> {
    let mut neighbours = vec![Vec::new(); nodes];
    for [a, b] in links {
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut order = Vec::with_capacity(nodes);
    let mut seen = vec![false; nodes];
    for node in 0..nodes {
        if !seen[node] {
            let start = outermost(&neighbours, node);
            seen[start] = true;
            order.push(start);
            let mut next = order.len() - 1;
            while next < order.len() {
                let mut around: Vec<usize> = neighbours[order[next]].iter().copied().filter(|&n| !seen[n]).collect();
                around.sort_by_key(|&n| (neighbours[n].len(), n));
                around.dedup();
                for &n in &around {
                    seen[n] = true;
                }
                order.extend(around);
                next += 1;
            }
        }
    }
    order.reverse();
    order
}

/// A peripheral node: the farthest from the farthest node from `node` (Gibbs, Poole & Stockmeyer 1976).
fn outermost(neighbours: &[Vec<usize>], node: usize) -> usize {
    let farthest = |from: usize| {
        let mut distance = vec![usize::MAX; neighbours.len()];
        distance[from] = 0;
        let mut front = vec![from];
        let mut last = from;
        while let Some(&first) = front.first() {
            last = front.iter().copied().min_by_key(|&n| neighbours[n].len()).unwrap_or(first);
            let mut following = Vec::new();
            for &n in &front {
                for &m in &neighbours[n] {
                    if distance[m] == usize::MAX {
                        distance[m] = distance[n] + 1;
                        following.push(m);
                    }
                }
            }
            front = following;
        }
        last
    };
    farthest(farthest(node))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn band(order: &[usize], links: &[[usize; 2]]) -> usize {
        let mut place = vec![0; order.len()];
        for (at, &node) in order.iter().enumerate() {
            place[node] = at;
        }
        links.iter().map(|&[a, b]| place[a].abs_diff(place[b])).max().unwrap()
    }

    #[test]
    fn a_shuffled_chain_has_a_band_of_one_and_a_ring_of_two() {
        let name = |i: usize| 37 * i % 101;
        let chain: Vec<_> = (0..100).map(|i| [name(i), name(i + 1)]).collect();
        assert_eq!(band(&narrow_band(101, chain.iter().copied()), &chain), 1);
        let mut ring = chain;
        ring.push([name(100), name(0)]);
        assert_eq!(band(&narrow_band(101, ring.iter().copied()), &ring), 2);
        let parts = [[0, 3], [3, 1], [4, 2]];
        let mut order = narrow_band(5, parts.iter().copied());
        assert_eq!(band(&order, &parts), 1);
        order.sort_unstable();
        assert_eq!(order, [0, 1, 2, 3, 4]);
    }
}
