//! Which sections each model holds for.

use super::model::{EntryModel, OutOfRange};
use super::section::Section;

impl EntryModel {
    /// Refuse a bottom outside the range of the model; it is wetted up to the half width `reach` [m].
    pub fn covers(self, section: &Section, reach: f64) -> Result<(), OutOfRange> {
        let [_, most] = self.deadrises();
        let steepest = section.steepest_within(reach);
        let refuse = |what: String, range: String| {
            let able = |r: &&EntryModel| **r > self && r.covers(section, reach).is_ok();
            Err(OutOfRange { what, range, next: *EntryModel::ALL.iter().find(able).unwrap_or(&EntryModel::Wcsph) })
        };
        match self {
            _ if !self.is_theory() => Ok(()),
            EntryModel::Similarity if section.deadrise_deg().is_none() => {
                refuse("a bottom that is no wedge".into(), format!("wedges of 4 to {most} degrees"))
            }
            EntryModel::Similarity if reach > section.half_breadth() => {
                refuse("a wedge whose chines are wet".into(), "wedges as long as the spray leaves their faces".into())
            }
            _ if steepest > most + 1e-6 => {
                refuse(format!("a face of {steepest:.2} degrees"), format!("faces of 4 to {most} degrees"))
            }
            _ => Ok(()),
        }
    }
}
