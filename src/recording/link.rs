//! Schema, channel and message records put together: what stands in a log itself and in its chunks.

use mcap::Message;
use mcap::read::{ChannelAccumulator, parse_record};
use mcap::records::Record;

/// Takes a schema, channel or message record; a message comes out with its channel.
pub(super) fn link(
    opcode: u8,
    body: &[u8],
    links: &mut ChannelAccumulator<'static>,
) -> mcap::McapResult<Option<Message<'static>>> {
    match parse_record(opcode, body)? {
        Record::Schema { header, data } => links.add_schema_from_slice(header, &data)?,
        Record::Channel(channel) => links.add_channel(channel)?,
        Record::Message { header, data } => {
            let unknown = mcap::McapError::UnknownChannel(header.sequence, header.channel_id);
            let channel = links.get(header.channel_id).ok_or(unknown)?;
            return Ok(Some(Message {
                channel,
                sequence: header.sequence,
                log_time: header.log_time,
                publish_time: header.publish_time,
                data: data.into_owned().into(),
            }));
        }
        _ => {}
    }
    Ok(None)
}
